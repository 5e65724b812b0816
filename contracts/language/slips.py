"""Words of the shipped crews whose slips were looked up, and slips among them that may be another word.

Made by tests/unit/contracts/language/make_slips.py; not to be edited.
"""

from crew.contracts.language.words import word_set

LOOKED_UP: frozenset[str] = word_set(
    """
    abort aborted aborting aborts accountant accountants across actor actors actress actresses adolescent adolescents
    adult adults advance advanced advances advancing aerial after afterward afterwards air airborne aircraft aircrafts
    airman airmans aloft along ambassador ambassadors amble ambled ambles ambling android androids angler anglers
    apple apprentice apprentices archaeologist archaeologists area arm armed arms armses around artist artists ascend
    ascended ascending ascends asks askses athlete athletes attend attended attendee attendees attending attends aunt
    auntie aunties aunts babies baby babysitter babysitters back backpacker backpackers baker bakers bandsman
    bandsmans barber barbers barista baristas bartender bartenders base bay bear bearing bears beekeeper beekeepers
    bellboy bellboys berry beside big bigger bike biker bikers bird birdwatcher birdwatchers bishop bishops block
    blogger bloggers bloke blokes boater boaters bore borne boss bosses bosun bosuns bot botanist botanists bots
    bottle bouncer bouncers boy boyfriend boyfriends boys bricklayer bricklayers bring bringing brings brother
    brothers brought buddies buddy buggies buggy builder builders bus butcher butchers bye bystander bystanders cab
    cadet cadets came camera cameraman cameramans cameras camper campers can cancel canceled canceling cancels canned
    canning canoeist canoeists cans canvass canvassed canvasses canvassing captain captains car caravanner caravanners
    care carer carers caretaker caretakers carpenter carpenters carried carries carry carrying cars casualties
    casualty cease ceased ceases ceasing chap chaps charger charging check checked checking checks chef chefs chief
    chiefs child children childs chopper choppers classmate classmates cleaner cleaners clerk clerks client clients
    climb climbed climber climbers climbing climbs club coach coaches colleague colleagues colonel colonels comb
    combed combing combs come comes coming commuter commuters competitor competitors concierge concierges conductor
    conductors constable constables construction contestant contestants contractor contractors contraption
    contraptions convey conveyance conveyed conveying conveys cook cooks coordinates coordinatesed coordinateses
    coordinatesing coordinator coordinators cop cops copter copters corporal corporals could coulded coulding coulds
    country courier courierman couriermans couriers cousin cousins cover covered covering covers cowboy cowboys
    coworker coworkers crew crewman crewmans crewmember crewmembers cross cub cube cubs customer customers cyclist
    cyclists dad daddies daddy dads dancer dancers daughter daughters dear dears deckhand deckhands delegate delegates
    deliver delivered delivering delivers delivery deploy deployed deploying deploys descend descended descending
    descends desist desisted desisting desists despatch despatched despatches despatching detect detected detecting
    detective detectives detects device devices devil devils direct directed directing director directors directs
    discover discovered discovering discovers dispatch dispatched dispatcher dispatchers dispatches dispatching diver
    divers dock docker dockers doctor doctors dog dogbot dogbots doggie doggies doggo doggoes doggy dogs down drive
    driven driver drivers drives driving droid droids drone drones drop dropoff dropped dropping drops drove drover
    drovers drummer drummers east eastern easthalf editor editors elder elders electrician electricians employee
    employees end ended ending ends engineer engineers enter entered entering enters evacuee evacuees everything
    everywhere exchange exhibitor exhibitors explore explored explores exploring extra extras fallen families family
    farm farmer farmers farmhand farmhands farmworker farmworkers father fathers fell fellow fellows female females
    festival festivalgoer festivalgoers fetch fetched fetches fetching fiance fiancee fiancees fiances field finally
    find finding finds firefighter firefighters fireman firemans first fisherman fishermans flatmate flatmates flew
    flies flown fly flyer flyers flying for forager foragers foreman foremans forestry found four freeze freezes
    freezing freshman freshmans friend friends from froze frozen fruit fugitive fugitives gadget gadgets gaffer
    gaffers gamekeeper gamekeepers gardener gardeners gave gentleman gentlemans gentlemen geologist geologists get
    gets getting girl girlfriend girlfriends girls give given gives giving glazier glaziers goer goers goes going
    golfer golfers gone goodbye got gotten governor governors grab grabbed grabbing grabs gramps grampses gran grandad
    grandads grandchild grandchilds granddad granddads granddaughter granddaughters grandfather grandfathers grandma
    grandmas grandmother grandmothers grandpa grandparent grandparents grandpas grandson grandsons grannies granny
    grans grape grasp grasped grasping grasps greet greeted greeting greets groom grooms ground groundsman groundsmans
    group guard guardian guardians guards guest guests guide guides gunner gunners guy guys hairdresser hairdressers
    half halt halted halting halts hand handed handing handler handlers hands handses hang hanged hanging hangs haul
    hauled hauling hauls have haved haves having head headed heading heads held helicopter helicopters hello helper
    helpers her here heres hiker hikers hill him his hitchhiker hitchhikers hold holding holds holidaymaker
    holidaymakers home horse horseman horsemans horsewoman horsewomans hotel hound hounds house housekeeper
    housekeepers hover hovered hovering hovers human humanlike humanoid humanoids hunt hunted hunter hunters hunting
    hunts hurt husband husbands ice individual individuals infant infantryman infantrymans infants injured inmate
    inmates inside inspect inspected inspecting inspector inspectors inspects instructor instructors intern interns
    into iris its janitor janitors jockey jockeys jogger joggers joiner joiners journalist journalists judge judges
    kayaker kayakers keep keeped keeping keeps kid kids laborer laborers labourer labourers lad laddie laddies ladies
    lads lady land landed landing landlord landlords lands large lass lasses lassie lassies later launch launched
    launches launching lawyer lawyers lay layed laying lays leader leaders lecturer lecturers legged legger leggers
    legs legses librarian librarians lieutenant lieutenants lifeboatman lifeboatmans lifeguard lifeguards lift lifted
    lifting lifts like liked likes liking little load loaded loader loaders loading loads locate located locates
    locating location lodger lodgers logger loggers look looked looking lookout lookouts looks lorry lost loved
    lumberjack lumberjacks machine machines mailman mailmans maintenance major majors make maked makes making male
    males man manager managers manlike mans marathon marathoner marathoners marine marines marshal marshals mate mates
    may mayed maying mayor mayors mays mechanic mechanics medic medics member members men mes messenger messengers
    might mighted mighting mights migrant migrants miner miners minor minors missing mission mom mommies mommy moms
    monk monks mother mothers motorbike motorcyclist motorcyclists motorist motorists mountain mountaineer
    mountaineers move moved moves moving multicopter multicopters mum mummies mummy mums mushroom musician musicians
    myself myselfs nan nana nanas nannies nanny nans navigate navigated navigates navigating near need needed needing
    needs neighbor neighbors neighbour neighbours nephew nephews next niece nieces north northern northhalf notaries
    notary novice novices nun nuns nurse nurses nursing observer observers off officer officers once one ones onto
    operation operational operationalarea operator operators organiser organisers organizer organizers orienteer
    orienteers other out over overdue packer packers pad painter painters pair pairs pal pals parachutist parachutists
    paraglider paragliders paramedic paramedics paratrooper paratroopers parishioner parishioners part participant
    participants parties party pass passed passenger passengers passerbies passerby passes passing pastor pastors
    patient patients patroller patrollers payload payloadtray pedestrian pedestrians pensioner pensioners people
    person persons photographer photographers pick picked picker pickers picking picks pickup pilgrim pilgrims pilot
    pilots pinpoint pinpointed pinpointing pinpoints place placed places placing plasterer plasterers player players
    plumber plumbers poet poets point policeman policemans policewoman policewomans pooch pooches poor pop popped
    popping pops porter porters portion position positioned positioning positions postman postmans postwoman
    postwomans presenter presenters priest priests prisoner prisoners private privates proceed proceeded proceeding
    proceeds producer producers professor professors pup pupil pupils puppies puppy pups put puts putting quad
    quadcopter quadcopters quadrocopter quadrocopters quadrotor quadrotors quadruped quadrupedal quadrupeds quads
    rabbi rabbis race racer racers rambler ramblers ranch ranger rangers recall recalled recalling recalls
    receptionist receptionists recon reconnaissance reconnoiter reconnoitered reconnoitering reconnoiters reconnoitre
    reconnoitred reconnoitres reconnoitring recruit recruits red redcube redeploy redeployed redeploying redeploys
    redirect redirected redirecting redirects referee referees refugee refugees region relative relatives relocate
    relocated relocates relocating relocation report reported reporter reporters reporting reports reposition
    repositioned repositioning repositions requester requesters reroute rerouted reroutes rerouting researcher
    researchers resident residents respond responded responding responds retiree retirees return returned returning
    returns rider riders rifleman riflemans rigger riggers right road roadie roadies robo robodog robodogs robot
    robots rock rolling roofer roofers room rooma roomb roommate roommates round route routed routes routing rover
    rovers run runned runner runners running runs sailor sailors sapper sappers say sayed saying says scaffolder
    scaffolders scan scanned scanning scans scholar scholars schoolboy schoolboys schoolchild schoolchilds schoolgirl
    schoolgirls schoolmate schoolmates scientist scientists scour scoured scouring scours scout scouts sculptor
    sculptors seaman seamans search searched searcher searchers searches searching seasonal second secretaries
    secretary section sector seek seeking seeks seize seized seizes seizing seller sellers send sending sends senior
    seniors sent sentries sentry sergeant sergeants serviceman servicemans servicewoman servicewomans set sets setted
    setting shepherd shepherds shift shifted shifting shifts shopkeeper shopkeepers shopper shoppers sibling siblings
    side sightseer sightseers singer singers sister sisters site skier skiers skydiver skydivers small smaller
    snowboarder snowboarders soldier soldiers son sons sophomore sophomores sorter sorters sought soul souls south
    southern southhalf spectator spectators spot spouse spouses staff stage stagehand stagehands stand standed
    standing stands start starting station stepdaughter stepdaughters stepfather stepfathers stepmother stepmothers
    stepson stepsons steward stewardess stewardesses stewards still stockman stockmans stop stopped stopping stops
    stranded stranger strangers streamer streamers stroller strollers student students stuntman stuntmans subject
    subjects subsequently supervisor supervisors surfer surfers survey surveyed surveying surveyor surveyors surveys
    survivor survivors suspect suspects sweep sweeping sweeps swept swimmer swimmers table tablea tableb tailor
    tailors take taken takeoff takeoffed takeoffing takeoffs takes taking tall taller tattooist tattooists taxi
    teacher teachers team teammate teammates technician technicians teen teenager teenagers teens tell telling tells
    tenant tenants the their them then there they thing things through throughout toddler toddlers told took touch
    touched touches touching tourist tourists toward towards track tracked tracking tracks tractor trail trainee
    trainees trainer trainers transfer transfered transfering transfers transport transportation transported
    transporting transports trapped travel traveled traveler travelers traveling traveller travellers travels tray
    trekker trekkers triathlete triathletes tripper trippers trooper troopers trot trots trotted trotting trouble
    truck trucker truckers trundle trundled trundles trundling turtlebot turtlebots twin twins two uav uavs ugv ugvs
    umpire umpires uncle uncles undergraduate undergraduates unit units university user users uses usher ushers using
    vacationer vacationers van vehicle vehicles vendor vendors vet veteran veterans vets via vicar vicars victim
    victims visitor visitors volunteer volunteers waiter waiters waitress waitresses walk walked walker walkers
    walking walks wanderer wanderers want wanted wanting wants warden wardens warehouse watcher watchers water wave
    waved waves waving way wedding welder welders went west western westhalf wheeled wheels wheelses when where
    whirlybird whirlybirds who whoever whole wife wifes wild with within woman womans women woodcutter woodcutters
    worker workers workman workmans wounded wretch wretches writer writers you youngster youngsters your youth youths
    zone zookeeper zookeepers
    """
)

DOUBTFUL: frozenset[str] = word_set(
    """
    aarmed aarms abby abck able ables abling abor abors abort abortin abot abots abrt abse aby accountant acme acn
    acor acors acr acre acress acresses acrs acto actor actresss add adds adolescent adul adult advance aeral afte
    afterward aftter agler agve airan aircraft airman airmn aks ald alng alof alon alot alter aly alying ambassador
    ambe ambel amble amed amle amles amn amr amrs ams amses amy android anger angers angle angler angles anler anlers
    ann anna annas anns ant anties ants aong aort aound apl aple apls appe appel appl apprentice aprt apss ara arce
    arcer arcers archaeologisst archaeologist archaeologits archeologist archeologists are ared ari arial arist arm
    arman armes armess armmed armss ars arses artisst artist artits ascen ascend ascendd ask askes askss ass asses
    assk asy ater athlete atken atll ator atten attend attendd attende attendee attned aun auns aunt auntie aut auts
    avn awy baack baase bab baber babes babie babysitter bac backpacker bae baer baers baes baista bak bake baker
    bakes bakr bakrs bandsman bar barbe barber barbes barbr barer barers baring barista bars bartender bas basse bater
    baters bay bbay bby bck bddies bddy bea beaing bear bearr bearrs beas beekeeper beide bellboy ber beraing bering
    bers bery besie bey bgger bggies bggy bid bie bier biers bigge bik bike biker bikes bing binging bings bir
    birdwatcher bishop bke bker bkers blck blke bllock bloc blogge blogger blok bloke bloks bndsman boater bock boe
    boer boke bone bonre booss boots bor bore boren born borre bos bosess bosn bosse bosss bost bosun bosy bot
    botanisst botanist botanits boter boters bother bothers boucer bought boun bounce bouncer bounces bouner bouns boy
    boyfriend brber brd bre bricklayer brid brig briging brigs briing brin bring brins brne broe brone brothe brother
    brothes brough brring brry bse bss bsses bts bttle bucher budd bugg bugges builder bulder bulders butcher butches
    bys bystander cacel cach caches cade cades cadet cae caer caers caet cam camer camera cameraman cameramn camers
    campe camper can cance cancel cancelled cancelling cances caned canel caning caninng canne cannig canns canoeist
    canvas canvased canvases canvasess canvasing canvasse canvasss cap caper capers caps captain captin captins car
    care caree career careers carer cares caretaker caries carpenter carpentr carr carre carred carrer carrers carres
    carrie carring carrs carss cary cas case cased cases casing casualy cator cators causalty cba cbs cbu ceaes cease
    ceasse cef cew cha chager chaging chap chapp charer charge chargin charing chas chck chcked chcking chcks che
    check checke checkeed chef chefs chek cheks ches chfe chfes chid chie chief chies chil child chilld chils choppe
    chopper chp chpper chps cie classmate cleaer cleane cleaner cleanes cleanesr cler clerk clers cliber clibers clien
    client clim climb climbe climber climed climing clims clint clmber clrk clu cme cna cnned cnning cns coac coache
    cob cobs coch coches coe coer coered coering coers coes coing cok coks cold colds colleague colone colonel colones
    colud coluded coluding coluds com comb combe combiing combin combinng come comed coming comme commes commute
    commuter commutes competitor coms comuter comuters concierge conductor coney coneys constable constrction
    constructin contable contactor contestant contractor contraption contration contrations conve conveed conveing
    convey conveye convy convys coo cook coomb coops coordinate coordinateed coordinatees coordinatess coordinator
    coos cop coper copers copper coppers copter corpora corporal cos cosin coss coter coud couded couding couds could
    couldd couled couling couls countr county courier cousin couurier cove coveed coveing cover coves covey coveys
    cowboy coworker cpo cps cra crae craer craers cras cre crer crewman crewmn cros crosss crried crries crry crrying
    crss crw cub cue curier cus customer cvers cyclisst cyclist cyclits dad dadd dadies dady daer daers dance dancer
    dances daner daners dar dars das daughter dck dcker dda dds dea dear dearr deas deckhand deect deected deecting
    deective deects deice deices deil deist deists delegate deliveer deliver delivere deliverr delver delvers deploy
    deply der dera ders descen descend descendd desised desising desisst desist desits despatche detect detectin
    detective detet deteted detets devi device devie devies devil devis dgo dgos dgs dier diers direct directin
    director diret direts discoveer discover discovere discoverr dispatche dispatcher dispatches dive diver divers
    dives diving doc docke docker dockes doctor dog dogg dogge dogges doggie doggoe dogie dogies dogy dok don done dop
    dopped dopping dops dorp dos dove dover dow drid drids drie drien drier driers dries drive driver drives dro droe
    droes droi droid drois dron drone drons droop droopping droops drop droping droppe dros drove drover droves drp
    drpped drpping drps drumme drummer drve drver drvers drves dspatch dspatched dspatches dspatching dver dwn eas
    easter eat eats ecase ecased ecasing edar eded eder eders eding editor edn edns eds elde elder eldes electrician
    eler emmber emmbers employe employee employes ems end endd ened enginee engineer enginees ens enter entere entr
    entre entres esat est ests eten eter eters evacuee exhibitor exploe exploed exploer exploers exploes exploing
    explore explorre explorres expored exporing extra faily fam famers fance fances far farer farmand farmands farme
    farmer farmes farmhand fater faters father feell feeze fel feld fellow female fetche few fiance fiancee fiances
    fiannce fiannces fid fids fied fiedl fiel fieldd fiend fiends fies fild filed files fin finace finaces finall
    finces find fining fins firefighter fireman firemn firs firsst firt firts fisherman fishermn fist flatmate fle
    fler flers fles flie fling flis fll fllies fllow fllows flon flow flw flyer fnd fnding fnds foeman fom fond for
    forage forager forages foreman foremn forestr forger forgers form foru fou foun foundd fown fram framer framers
    freee freees freeing freeze freman freshman freshmn freze fried frieman friend frined frit frm frmer frmers fro
    froe froen fromm froze frst ftch fugitive fund fuor fur fyer fyers fying gaave gab gabbed gabbing gabs gadget gae
    gaekeeper gaekeepers gaffe gaffer gaffes gamekeeper gamps gan gans gape garb garbs gard gardener gardenr gardneer
    gardner gards gasp gasped gasping gasps geet geets gentleman gentlemn geologisst geologist geologits geos ger
    geret gerets gers ges gest get gide gides gie gies gil gils gir girl girlfriend girll girlls girs give glaier
    glaiers glazer glazers glazier gne gnoe goe goer goes gofer gofers goin golfer gon gong goodby gooer gooes gooing
    goom gor gore gores gors gos gose governor gra grab grabb grabbe grae grampss grams gran granad granda grandad
    grandadd grandads grandam grandams grandas grandchild grandd grandda granddad granddadd granddads granddaughter
    grandds grandfather grandma grandmother grandpa grandpaa grandparent grandppa grandson grann grannie grany grap
    graping grappe graps gras grased grasing grasp grass grassp grb grbbing grbs gree greeed greeing grees greet
    greete gret grets gril grils grn grns groo groom groos grop grou groundd groundsman grpe grund grup gte gtes gts
    gtting guar guard guardd guardian guardin guars gues guess guesst guest guets guid guidde guide guids guie guied
    guies guner gunne gunner gunnr gurd gurds gus guset gust gusts gusy guv guvs guy gve gys had haded hading hadn
    hads hae haed haeds haes hag hagn hags haing hairdresser hal haled haling hals halt halte han hand handd hande
    handes handle handler handles handse handss haned hang hange haning hans hat hated hating hats hau haul haule haus
    have hea head headd heade heaed heaing heas hed heded heding heds hee heeld heer heers hees hel heler helers
    helicopter hell helpe helper her here heress hers herse hier hiers hike hiker hikes hil hilll hitchhike hitchhiker
    hitchhikes hld hled hll hllo hlt hlts hme hnd hnds hng hnged hnt hnted hnting hnts hod hods hoe hoel hoer hoers
    hol hold holidaymaker holing hols hom hond hoover hoovered hoovering hoovers hore hores hors horseman horsemn
    horsewoman horsse hose hotl houes hound houndd hous housekeeper housse hove hover hoves hre hres hrt hte hting
    hual huan hul huled huling huls humanoid hun huner huners huns hunt hunte hunter hunterss huntres hur husband huse
    hut huting huts hve hvering hves hwen hwo hwoever iar iis inate individual individuall infant infantryman
    infantrymn inide injure inmate ino inot insect insects inspect inspectin inspector instructor int inten intens
    inter intern inters inured iriss irs ist ito iva janitor jgger jockey jogge jogger joine joiner jokey joner
    journalis journalisst journalist journalits jude judge kayaker kee keeed keeing keep keepe kees kep kid kis labore
    laborer laborers laborr laborrs labourer labourr lad ladde laddes laddie laddies laded lader laders lades ladie
    ladies lading ladn lads laed laer lage lagre laing lan land landd lande landlord laned laning lans larg las lases
    lasse lasses lassie lasss late latter launces launche lawyer lay layd laye layeed layer layers lda ldger ldgers
    lds leade leader leaer leaers lectuer lectuers lecture lecturer lectures lecturre lecturres leder leders leg leged
    leger legers leges legess legge legger legss les leses lfit lfits lft lfts lgged lgger lggers lgs librarian lie
    lied lies lieutenant lif lifeguard lift lifte liing lik like likeed liks lit lited liting lits litte lke lkes
    lland lnd lnding lnds loa load loadd loade loader loaed loaer loaers loaing loas loate loated loates loating locae
    locaes locate locatin lod loded loder loders lodge lodger lodges loding lods loed loger logers logge logger lok
    loked loking lokout loks loo looed looing look looke lookout loos lory los lot lots love lrry lsot lss lsses lst
    lter lumberjack lunch lunched lunches lunching lved lya lying maanger maans mable mabled mables mabling machine
    mae maed mael maels maes maet maets mailman maiman maine maines maing major mak make maks mal male malle mals man
    manage manager manages manger mangers maor maors marathoner marie maries marin marine marinne marins marne marsha
    marshal marshall mas masn mat mate mats matte mattes may maye mayo mayor mayr meber mebers mechanic mechanis medci
    medi medic mediic member messenger mier miers might migrant migrat migrats milman mine miner mines mino minor
    minos minr minrs mior mising missin mke mkes mle mles mmmies mmmy mmo mmos mms mmu mmus mna mnager mnas mne mnk
    mnks mnor mnors mns moe moed moes moing mok moks mom momm mon monk mons mos mother motorcyclisst motorcyclist
    motorcyclits motorisst motorist motorits mountaineer mountin move mraine mrine mse mssing mte mtes mther mum mumm
    mus musician mya mys myself naa naan naans naas naer nan nana nann nanna nannie nans nany nar nas navigate
    navigatin nea nearr ned neded neding neds nee need needd neede neeed neighbor neighbors neighbour nephew ner net
    neter netered netering nice nicee nices niec niece nito nna nnny nns nnu nnus noce noe noes noice noices northen
    norther notarie noth novice nrse nucle nucles nun nures nurse nursse nus observe observer observes obss obsses obt
    obts oby obys ocne oen oens oer oes office officer offices oger ogers oges oging omm omms one onnce ono ons onse
    ont operatin operationall operator opp opps organier organiers organise organiser organises organize organizer
    organizes orienteer oter oto otward otwards ove overue ozne paart pace paced pacer pacers paces pacing packe
    packer packes pai painer painte painter pair pais paker pal palce palces palls panter panters par parachutisst
    parachutist parachutits paraglider paramedic paratrooper pari paries paris parishioner parrt pars part participant
    participat participats partie partt pary pas pased pases pasing passe passenger passin passs passse pasto pastor
    pastr pat patent patents patient paties patries patrolle patry paty payer payers payloa pck pcked pcker pckers
    pcking pcks pedestrian peerson pensione pensioner peot peron person peson pet pets photographe photographer pic
    piced picer picers picing pick picke pickeed picker pickes pics pik piked piker pikers piking piks pilgrim pilo
    pilot pinpoint pint pinter pinters piont piot pir pirs pisoner pla plaace plaaces placd place plae plaed plaer
    plaes plaing plas plasteer plasteers plastere plasterer plasterr plasterrs playe player plot plots pls plumbe
    plumber plumer poch poches poe poes poet poin poit policeman policemn policewoman policewomn poo pooc pooh poopped
    poopping poops poorr pop poped poping poppe poppin popps por porer poro porte porter portin porton pos positin
    position positon postman postmn postwoman pot pote poter poters potion potman pots ppo ppos pppies pppy pps ppu
    ppups ppus prat prceeded prceeding presente presenter preson prest prests priate priates pries priesst priest
    priestss priets prisoner prists private privatee privatees proceed proceedd proceeed produce producer produces
    produer proessor proessors professor proter prson prsons prt prter psas psot pss pssed psses pssing pts ptting pup
    pupil pupl pupp puppes puppis pus put puting puttin putts qua quad quadrupe quadruped quas qud quds rabbi rabi
    rabis rac race racer races rach rad radies rae raer raers ram ramble rambler rambles ramed rams ramses ranc range
    ranger ranges rbo rboot rboots rce rck rde rder rdier rdone reall realls reative recal recall receptionisst
    receptionist receptionits reconnoite reconnoiter reconnoiters reconnoitr reconnoitre recruit redcue redeploy
    redirect redirectin referee refuge refugee refuges regin relative rellocation relocate relocatin reocation reon
    reort reorted reorting reorts repor report reporte reporter reposition requeste requester rerote reroute researche
    researcher researches resident resond resonded resonding resonds respond respondd responde respons retire retiree
    retires retriee retriees retun retuning return reurn reurns ride rider rides rier riers rifleman riflemn riger
    rigers rigge rigger rnger rngers roa roadie rob robot robt roc rod roda rodies roer roers rok roling rollin rom
    roma romo rond roo rooam roob rooer roofe roofer room roommate root roots rote roted roting roue roued roues
    rouing roun roundd rout route routin routs rove rover roves rroute rrouted rroutes rrouting rruns rtail rtainer
    rtainers run runed runing runne runner runnes rus ruted ruting rver rvers saed sage sailor saing saior saiors saks
    sall saman samans san sand sanded sanding sands sanned sanning sans saper sappe sapper sarch sarched sart sarting
    sas sasy say sca scan scanne scas scholar schoolboy schoolchild schoolgirl schoolmate scientisst scientist
    scientits scor scored scoring scors scot scots scotu scotus scou scoued scouing scour scoure scous scout sction
    sculptor scured scuring scut scuts sde sdie seaan seaman seamn searche searcher searches seasonall secondd
    secretry sed seding sedn sedns seds see seection seector seeing seek seep seeping seeps sees seets seie seies
    seize seizin seler selers seller sen send sening senior senor senors sens sensd sept sergeant serviceman servicemn
    servicewoman ses set seted seting setn sette setts seward shepherd shepherdss shft shfted shfting shfts shift
    shifte shit shited shiting shits shopkeeper shoppe shopper shoppes shpper shppers sibling sid sidde sie sied sier
    sift sifted sifting sifts siger sigers sightseer signer signers siister siite siker siling sill simmer simmers
    siner siners singe singer singes singger singgers sister sit siter siters sitte size sized sizes sizing skie skier
    skies skir skirs skydive skydiver skydives sldier sldiers smll snd snding snds snger sniger snigers sno snos
    snowboarder sns snt sol solder solders soldier solider solier sols solus son soons sop sophomore sopped sopper
    soppers sopping sops sorer sorers sorte sorter sortes sos sot soter soth sou sough souht soul sour soured souring
    sours sous souse souses sout souther souts spectator spo spott spoues spous spouse spousse spper sppers spt
    sreamer sreamers stad stae stag stagehand stagge stan stand standd staned staning stans star staring stat statin
    stating staton ste steamer steamers stepdaughter stepfather stepmother stepson stes steson stewar steward
    stewardesss stewardss stff stie stil stll sto stockman stoop stoopped stoopping stoops stop stoped stoping stoppe
    stp stpped stpping stps strandd straned straner strange stranger stranges strat streame streamer strnger strolle
    stroller strt sts stted stting student stuntman stuntmn subject suer suers sues sufer sufers suing sul suls
    supervisor surer surey surfe surfer survey surveyor survivor survy suspect swee sweep swees swep swet swimmer sya
    sying sys taable tabl tabla table tack tacked tacking tacks tae taek taem taen taes tai tail tailor taing tak take
    takeoff takin takn taks tal tale taler talle talor tam tapped tary tattooist tavel tax tea teache teacher teaches
    teammate technician tee teen teenage teenager teenn tees teh teir tel tell tels tem ten tenant tene tenes tennt
    tennts tens tere tey the thee theem ther theree thig thigs thin thing thins thir thme thn thne thng thngs thorugh
    though thre three throough throughut thy thye tin ting tings tins tipper tippers tis tke tken tkes tking tld tll
    tller tlling tlls toch toched toches toching tod toddle toddler toddles tok toko tol tolld too toold tort torts
    tot tots totted totting touche touh touris tourisst tourist tourits tow toward tra traail trac traced tracing
    track tracke tracs trai traier traiers traine trainee trainer traines tral transfer transfere transferr
    transferred transferring transport transporte traped trappe trator trave travel travele traveler travelers
    travelle travelled traveller travellers travelling traves trck trcked trcker trckers trcking trcks trekke trekker
    trial triathlete tril trippe tripper tro trooper tros trot trotte trough trpped trpper trppers trt trts truc
    trucke trucker truk trundle try tthing tuck tucker tuckers twi twin twis twn twns uas ubs uer ues ugs ugv ugy uher
    umm umpire uncle undergraduate uni unis unit unles unt unti unts upp upps urn urns use user users uses usher usng
    usr usre uss usse vacatione vacationer vai vehicle veicle veicles vendor ves vest vet veteran vetss vicar victim
    visitor vitim vna voer volunteer vte vtes vts waden wae waed waer waes waier waiers waing waite waiter waiterss
    waitres waitresss waivng wak waked waker wakers waking wakling waks wal waled waler walers waling walk walke
    walker walkes wals wan wandeer wandeers wandere wanderer wanderr wanderrs waned waning wans want warde warden
    wardes warehoues warehousse waren wat watche watcher watches wate wated water waters wather wathers wating watr
    wats wav wave waveed waviing wdding weding weedding weest welde welder weler wen were wes wester wet wets whe whee
    wheel wheelde wheele wheeles wheelss wheen whees whirlybird whle whne whoe whooever whre wid wie wies wif wife wih
    wiht wil willd wit witer witers wld wlder wnt wnted woen wole woman womn woodcutter wooman worer worke worker
    workman workmn woundd wrech wreches wretche wreth wrier write writer writes wst wto wve wves yor you youngster
    youth yuo yur zne zoe zon zookeeper zoone
    """
)
